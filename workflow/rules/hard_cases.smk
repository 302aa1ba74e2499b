# Hard cases: one job each, so that a change reruns what depends on it; a case that fails is a row
# of the table that says so, not a failed job.


rule measure_hard_case:
    input:
        model=hard_case_model,
    output:
        "results/hard_cases/{case}.csv",
    log:
        "results/logs/measure_hard_case/{case}.log",
    resources:
        mem_mb=2000,
    params:
        code=hard_case_code,
        model=lambda wildcards, input: ("--model results/models/forecast" if input.model else ""),
    shell:
        "sedfiber measure_hard_case {wildcards.case} {params.model} -o {output} > {log} 2>&1"


rule tabulate_hard_cases:
    input:
        expand("results/hard_cases/{case}.csv", case=HARD_CASES),
    output:
        "results/tables/hard_cases.csv",
    log:
        "results/logs/tabulate_hard_cases.log",
    params:
        code=code_of("tabulate_hard_cases"),
    shell:
        "sedfiber tabulate_hard_cases {input} -o {output} > {log} 2>&1"


rule hard_cases:
    input:
        figures_of("hard_cases"),
