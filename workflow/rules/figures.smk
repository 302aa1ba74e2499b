# Figures are drawn from tables alone.


rule plot_reconstruction:
    input:
        sources("plot_reconstruction"),
        table="results/tables/reconstruction.csv",
    output:
        svg="results/figures/reconstruction.svg",
        png="results/figures/reconstruction.png",
    log:
        "results/logs/plot_reconstruction.log",
    benchmark:
        "results/benchmarks/plot_reconstruction.tsv"
    conda:
        "../../envs/figures.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    message:
        "draw the reconstruction loss"
    shell:
        "sedfiber plot_reconstruction {input.table}"
        " --svg {output.svg} --png {output.png} > {log} 2>&1"


rule plot_forecast_errors:
    input:
        sources("plot_forecast_errors"),
        table="results/tables/ensemble_errors.csv",
    output:
        svg="results/figures/forecast_errors.svg",
        png="results/figures/forecast_errors.png",
    log:
        "results/logs/plot_forecast_errors.log",
    benchmark:
        "results/benchmarks/plot_forecast_errors.tsv"
    conda:
        "../../envs/figures.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        model=config["node"]["forecast_model"],
    message:
        "draw the ensemble-mean error over the settling period"
    shell:
        "sedfiber plot_forecast_errors {input.table} --model {params.model}"
        " --svg {output.svg} --png {output.png} > {log} 2>&1"


rule plot_baselines:
    input:
        sources("plot_baselines"),
        table="results/tables/baselines.csv",
    output:
        svg="results/figures/baselines.svg",
        png="results/figures/baselines.png",
    log:
        "results/logs/plot_baselines.log",
    benchmark:
        "results/benchmarks/plot_baselines.tsv"
    conda:
        "../../envs/figures.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    message:
        "draw worst and median error beside the baseline"
    shell:
        "sedfiber plot_baselines {input.table}"
        " --svg {output.svg} --png {output.png} > {log} 2>&1"


rule plot_error_distribution:
    input:
        sources("plot_error_distribution"),
        table="results/tables/forecast_errors.csv",
    output:
        svg="results/figures/error_distribution.svg",
        png="results/figures/error_distribution.png",
    log:
        "results/logs/plot_error_distribution.log",
    benchmark:
        "results/benchmarks/plot_error_distribution.tsv"
    conda:
        "../../envs/figures.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    message:
        "draw the largest error of every trajectory"
    shell:
        "sedfiber plot_error_distribution {input.table}"
        " --svg {output.svg} --png {output.png} > {log} 2>&1"


rule errors:
    input:
        rules.tabulate_forecast_errors.output,
        rules.plot_reconstruction.output,
        rules.plot_forecast_errors.output,
        rules.plot_baselines.output,
        rules.plot_error_distribution.output,
