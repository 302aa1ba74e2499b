# One autoencoder per variant, latent dimension and seed; POD beside them in the table.


rule train_autoencoder:
    input:
        split_files("train"),
    output:
        model_files("results/models/autoencoders/{variant}_d{dim}_s{seed}"),
    log:
        "results/logs/train_autoencoder/{variant}_d{dim}_s{seed}.log",
    group:
        "autoencoders"
    resources:
        mem_mb=2000,
        runtime=20,
    params:
        code=code_of("train_autoencoder"),
        settings=lambda wildcards: as_json(STUDY.autoencoder_settings(**wildcards)),
        folder=lambda wildcards, output: Path(output[0]).parent,
    shell:
        "sedfiber train_autoencoder {input} --settings {params.settings:q} -o {params.folder}"
        " 2>&1 | tee {log}"


rule tabulate_reconstruction:
    input:
        training=split_files("train"),
        tests=[split_files(split) for split in TEST_SETS],
        models=[model_files(folder) for folder in AUTOENCODERS],
    output:
        "results/tables/reconstruction.csv",
    log:
        "results/logs/tabulate_reconstruction.log",
    resources:
        mem_mb=4000,
    params:
        code=code_of("tabulate_reconstruction"),
        models=AUTOENCODERS,
    shell:
        "sedfiber tabulate_reconstruction {input.training} --tests {input.tests} --models {params.models}"
        " -o {output} > {log} 2>&1"


rule autoencoders:
    input:
        rules.tabulate_reconstruction.input.models,
        rules.tabulate_reconstruction.output,
